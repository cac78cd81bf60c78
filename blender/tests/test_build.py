"""The build of the zip, without what takes long."""

from __future__ import annotations

import pathlib
import sys
import tempfile
import tomllib
import unittest
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
import build  # noqa: E402


class Building(unittest.TestCase):
    def test_platforms(self) -> None:
        for tag, platform in (
            ("manylinux_2_28_x86_64", "linux-x64"),
            ("manylinux_2_17_aarch64.manylinux2014_aarch64", "linux-arm64"),
            ("macosx_11_0_arm64", "macos-arm64"),
            ("macosx_10_12_x86_64", "macos-x64"),
            ("win_amd64", "windows-x64"),
        ):
            wheel = pathlib.Path(f"pleach-0.1.0-cp39-abi3-{tag}.whl")
            self.assertEqual(build.platform_of(wheel), platform)
            manifest = tomllib.loads(build.manifest_of(wheel))
            self.assertEqual((manifest["platforms"], manifest["wheels"]), ([platform], [f"./wheels/{wheel.name}"]))
            self.assertEqual(list(manifest["permissions"]), ["files"])
        for other in ("musllinux_1_2_x86_64", "emscripten_4_0_wasm32"):
            with self.assertRaisesRegex(SystemExit, f"{other}, which Blender does not run on"):
                build.platform_of(pathlib.Path(f"pleach-0.1.0-cp39-abi3-{other}.whl"))

    def test_no_wheel(self) -> None:
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(SystemExit, "there is no file"):
            build.build(pathlib.Path(folder, "pleach-0.1.0-cp39-abi3-win_amd64.whl"), pathlib.Path(folder))

    def test_the_same_files_make_the_same_zip(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder, "source")
            source.mkdir()
            (source / "one.py").write_text("one = 1\n")
            made = []
            for name in ("a.zip", "b.zip"):
                (source / "one.py").touch()
                build.pack(source, pathlib.Path(folder, name))
                made.append(pathlib.Path(folder, name).read_bytes())
            self.assertEqual(made[0], made[1])
            self.assertEqual(zipfile.ZipFile(pathlib.Path(folder, "a.zip")).namelist(), ["one.py"])


if __name__ == "__main__":
    unittest.main()
