"""A wheel of a package that is built in place, for tests: `wheel.py PACKAGE OUT`."""

from __future__ import annotations

import base64
import hashlib
import pathlib
import sys
import sysconfig
import zipfile

package, out = map(pathlib.Path, sys.argv[1:])
platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
info = "pleach-0.1.0.dist-info"
files = {
    path.relative_to(package.parent).as_posix(): path.read_bytes()
    for path in sorted(package.rglob("*"))
    if path.is_file() and "__pycache__" not in path.parts
}
files[f"{info}/METADATA"] = b"Metadata-Version: 2.1\nName: pleach\nVersion: 0.1.0\nRequires-Dist: numpy>=1.22\n"
files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: pleach\nRoot-Is-Purelib: false\nTag: cp39-abi3-{platform}\n".encode()
lines = []
for name, data in files.items():
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    lines.append(f"{name},sha256={digest},{len(data)}")
files[f"{info}/RECORD"] = "\n".join([*lines, f"{info}/RECORD,,", ""]).encode()
out.mkdir(parents=True, exist_ok=True)
with zipfile.ZipFile(out / f"pleach-0.1.0-cp39-abi3-{platform}.whl", "w", zipfile.ZIP_DEFLATED) as wheel:
    for name, data in files.items():
        wheel.writestr(name, data)
