#!/usr/bin/env python3
"""Builds the Blender extension: a zip with the wheel of pleach for one platform and pictures of all species.

    python3 blender/build.py                        # builds the wheel first, with maturin
    python3 blender/build.py --wheel pleach-….whl   # takes one that is there

Needs numpy, to paint the pictures.
"""

from __future__ import annotations

import argparse
import importlib
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zipfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE / "pleach_trees"
#: What a zip may weigh, in bytes.
MAX_SIZE = 10_000_000
#: Pixels of a picture of a species.
SIDE = 56
#: Blender's names of platforms by what wheels say.
PLATFORMS = {
    r"(linux|manylinux\w+)_x86_64": "linux-x64",
    r"(linux|manylinux\w+)_aarch64": "linux-arm64",
    r"macosx_\d+_\d+_x86_64": "macos-x64",
    r"macosx_\d+_\d+_arm64": "macos-arm64",
    r"win_amd64": "windows-x64",
    r"win_arm64": "windows-arm64",
}


def platform_of(wheel: pathlib.Path) -> str:
    """Blender's name of the platform of a wheel, by its last tag."""
    tags = wheel.stem.split("-")[-1].split(".")
    for tag in tags:
        for pattern, name in PLATFORMS.items():
            if re.fullmatch(pattern, tag):
                return name
    raise SystemExit(f"{wheel.name} is for {', '.join(tags)}, which Blender does not run on")


def build_wheel(folder: pathlib.Path) -> pathlib.Path:
    """A wheel of pleach for this machine."""
    manifest = HERE.parent / "crates/python/Cargo.toml"
    command = ["maturin", "build", "--release", "--strip", "--manifest-path", str(manifest), "--out", str(folder)]
    try:
        subprocess.run(command, check=True)
    except FileNotFoundError:
        raise SystemExit("maturin cannot be found: pip install 'maturin>=1.9,<2', or give --wheel") from None
    return next(folder.glob("pleach-*.whl"))


def manifest_of(wheel: pathlib.Path) -> str:
    """The manifest, with the wheel and its platform."""
    text = (SOURCE / "blender_manifest.toml").read_text(encoding="utf-8")
    lines = f'platforms = ["{platform_of(wheel)}"]\nwheels = ["./wheels/{wheel.name}"]\n'
    return text.replace("\n[permissions]", f"{lines}\n[permissions]")


def png_of(rgba) -> bytes:  # type: ignore[no-untyped-def]
    """A PNG file of uint8 of shape (height, width, 4)."""
    height, width, _ = rgba.shape
    rows = b"".join(b"\0" + row.tobytes() for row in rgba)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def thumbnails(folder: pathlib.Path, wheel: pathlib.Path) -> int:
    """Paints every species, with the wheel itself or, where it is for another platform, with the pleach that is installed;
    returns how many."""
    # Windows keeps the library, which stays loaded.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as unpacked:
        zipfile.ZipFile(wheel).extractall(unpacked)
        sys.path.insert(0, unpacked)
        try:
            pleach = importlib.import_module("pleach")
        except ImportError:
            sys.path.remove(unpacked)
            try:
                pleach = importlib.import_module("pleach")
            except ImportError as error:
                raise SystemExit(f"no pictures of species: {error}; install pleach and numpy") from None
        names = pleach.species()
        for name in names:
            picture = pleach.species(name).grow().render(2 * SIDE).astype("uint16")
            # Four pixels for one: smooth edges.
            small = (picture[::2, ::2] + picture[1::2, ::2] + picture[::2, 1::2] + picture[1::2, 1::2] + 2) // 4
            # Five bits a channel take half of the room.
            few = small.astype("uint8") & 0xF8
            (folder / f"{name}.png").write_bytes(png_of(few | few >> 5))
        return len(names)


def repack(wheel: pathlib.Path, out: pathlib.Path) -> None:
    """The same wheel, packed with LZMA: a sixth smaller. Blender unpacks wheels with Python, which knows it; PyPI takes no
    such wheels."""
    with zipfile.ZipFile(wheel) as source, zipfile.ZipFile(out, "w", zipfile.ZIP_LZMA) as archive:
        for info in source.infolist():
            copy = zipfile.ZipInfo(info.filename, (1980, 1, 1, 0, 0, 0))
            copy.external_attr = info.external_attr
            archive.writestr(copy, source.read(info), zipfile.ZIP_LZMA)


def pack(folder: pathlib.Path, out: pathlib.Path) -> None:
    """A zip of a folder: the same bytes for the same files."""
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path in sorted(folder.rglob("*")):
            if path.is_file():
                info = zipfile.ZipInfo(path.relative_to(folder).as_posix(), (1980, 1, 1, 0, 0, 0))
                info.external_attr = 0o644 << 16
                # Wheels are zips already.
                kind = zipfile.ZIP_STORED if path.suffix in (".whl", ".png") else zipfile.ZIP_DEFLATED
                archive.writestr(info, path.read_bytes(), kind, 9)


def build(wheel: pathlib.Path | None, out: pathlib.Path, most: int | None = MAX_SIZE) -> pathlib.Path:
    """Builds the zip into the folder ``out``; returns its path."""
    with tempfile.TemporaryDirectory() as temporary:
        wheels = pathlib.Path(temporary, "wheel")
        wheels.mkdir()
        wheel = wheel or build_wheel(wheels)
        if not wheel.is_file():
            raise SystemExit(f"there is no file {wheel}")
        stage = pathlib.Path(temporary, "stage")
        shutil.copytree(SOURCE, stage, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(HERE / "LICENSE", stage / "LICENSE")
        (stage / "wheels").mkdir()
        repack(wheel, stage / "wheels" / wheel.name)
        (stage / "blender_manifest.toml").write_text(manifest_of(wheel), encoding="utf-8")
        (stage / "thumbnails").mkdir()
        count = thumbnails(stage / "thumbnails", wheel)
        version = re.search(r'^version = "(.+)"', manifest_of(wheel), re.MULTILINE)
        assert version
        out.mkdir(parents=True, exist_ok=True)
        archive = out / f"pleach-{version[1]}-{platform_of(wheel)}.zip"
        pack(stage, archive)
    size = archive.stat().st_size
    print(f"{archive}: {size / 1e6:.1f} MB, {count} species")
    if most is not None and size > most:
        raise SystemExit(f"the zip has {size} bytes, expected up to {most}")
    return archive


def main() -> None:
    parser = argparse.ArgumentParser(description="Builds the Blender extension of pleach.")
    parser.add_argument("--wheel", type=pathlib.Path, help="a wheel of pleach; by default one is built")
    parser.add_argument("--out", type=pathlib.Path, default=HERE / "dist", help="where the zip goes (default: blender/dist)")
    parser.add_argument("--any-size", action="store_true", help="for tests: a zip with a wheel that is not optimised")
    given = parser.parse_args()
    build(given.wheel, given.out, None if given.any_size else MAX_SIZE)


if __name__ == "__main__":
    main()
