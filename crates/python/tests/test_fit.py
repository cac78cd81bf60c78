"""Fits: the program's bits, interruption, progress, pickles."""

from __future__ import annotations

import os
import pathlib
import pickle
import shutil
import signal
import subprocess
import sys
import textwrap
import time
from typing import Any

import numpy as np
import pytest

import pleach

ROOT = pathlib.Path(__file__).parents[3]
GOAL = ROOT / "targets" / "acer.png"
# Not of the species that fits here start from: at its own numbers nothing would be better.
OTHER = ROOT / "targets" / "hill_cherry.png"
SMALL: dict[str, Any] = {"start": "acer", "size": 48, "evaluations": 40, "individual": "24trees"}


@pytest.fixture(scope="module")
def found() -> pleach.Fit:
    return pleach.fit(OTHER, **SMALL)


def program() -> str:
    """The program, if it was built here."""
    built = [os.environ.get("PLEACH", "")] + [str(ROOT / "target" / how / "pleach") for how in ("release", "debug")]
    for path in built:
        if path and shutil.which(path):
            return path
    pytest.skip("the program is not built: cargo build")


def test_a_fit_tells_all_there_is(found: pleach.Fit) -> None:
    assert found.species.name == OTHER.stem and found.evaluations >= 40 and not found.interrupted
    assert found.individual is not None and found.individual.own_draws > 0 and found.species.own_draws == 0
    assert found.best is found.individual
    assert set(word for _, word in found.identifiability.values()) <= {"determined", "loosely", "not-seen", "not-tried"}
    history = found.history
    assert len({len(column) for column in history.values()}) == 1 and history["best_cost"][-1] <= history["best_cost"][0]
    assert found.verdict and found.fresh_likeness is not None and 0 < found.fresh_likeness[0] < 1
    assert found.goal.shape == found.silhouette.shape == found.overlay().shape[:2]
    # The pictures are those of the species. Its card has more paper at both sides: the crown nearly fills the picture.
    again = pleach.score(found.silhouette, found.goal)
    assert again.iou == pytest.approx(found.card.iou, abs=0.01)
    assert pickle.loads(pickle.dumps(found)).species == found.species


def test_this_very_tree_can_be_left_out() -> None:
    for off in ("off", False):
        found = pleach.fit(GOAL, **{**SMALL, "individual": off})
        assert found.individuals == [] and found.best is found.species
    # An acer is like those that what is built in knows, once there are pixels enough to tell.
    found = pleach.fit(GOAL, **{**SMALL, "size": 128, "individual": "off"})
    assert len(found.intervals) > 20 and set(found.intervals) <= set(found.identifiability)
    for number in found.intervals.values():
        assert number.posterior.low <= number.posterior.median <= number.posterior.high and 0 <= number.shrunk <= 1
    with pytest.raises(pleach.FitError, match="400trees`, `share` or `off`"):
        pleach.fit(GOAL, **{**SMALL, "individual": "on"})


def test_seeds_of_fits_are_whole_numbers() -> None:
    for option in ("seed", "tree_seed"):
        with pytest.raises(pleach.PleachError, match="seed` is -1: .*a whole number"):
            pleach.fit(GOAL, **{**SMALL, option: -1})


def test_this_very_tree_lies_on_the_goal() -> None:
    # From another tree than the goal, which lies on it as it is.
    found = pleach.fit(GOAL, start="acer", tree_seed=2, size=128, evaluations=40, individual="200trees")
    assert found.individuals[0].card.iou > found.card.iou + 0.02


@pytest.mark.parametrize("more", [{}, {"start": "auto", "evaluations": 25, "leaves": True}])
def test_a_fit_is_the_program_s(more: dict[str, Any], tmp_path: pathlib.Path) -> None:
    options = {**SMALL, **more}
    found = pleach.fit(GOAL, **options)
    leaves = ["--leaves", "on"] if options.get("leaves") else []
    command = [program(), "fit", GOAL, "--out", "run", "--from", options["start"], "--size", "48", *leaves]
    command += ["--evaluations", str(options["evaluations"]), "--individual", "24trees"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    for file, species in (("best", found.species), ("individual", found.individual)):
        assert pleach.species(tmp_path / "run" / f"{file}.toml") == species, file


def test_further_views_are_fitted_as_the_program_fits_them(tmp_path: pathlib.Path) -> None:
    from PIL import Image

    tree = pleach.species("acer").grow(5)
    for name, azimuth in (("front", 0), ("side", 90)):
        Image.fromarray(tree.silhouette(64, view=azimuth)).save(tmp_path / f"{name}.png")
    found = pleach.fit(tmp_path / "front.png", views=[(tmp_path / "side.png", 90)], **SMALL)
    assert len(found.view_cards) == len(found.individuals[0].view_cards) == 1
    assert 0 < found.view_cards[0].likeness < 1 and found.view_cards[0] != found.card
    command = [program(), "fit", "front.png", "--view", "90=side.png", "--out", "run", "--from", "acer"]
    command += ["--size", "48", "--evaluations", "40", "--individual", "24trees"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    assert pleach.species(tmp_path / "run" / "individual.toml") == found.individual
    with pytest.raises(pleach.GoalError):
        pleach.fit(GOAL, views=[(np.zeros((64, 64), bool), 90)], **SMALL)


def test_threads_change_nothing(found: pleach.Fit) -> None:
    for threads in (1, 3):
        other = pleach.fit(OTHER, threads=threads, **SMALL)
        assert (other.species, other.individual, other.cost) == (found.species, found.individual, found.cost)


def test_progress_is_told_and_its_errors_are_raised() -> None:
    told: list[dict[str, Any]] = []
    pleach.fit(GOAL, progress=told.append, **SMALL)
    stages = [one["stage"] for one in told]
    assert {"begun", "search", "judging", "individual"} <= set(stages)
    assert stages.index("search") < stages.index("judging") < stages.index("individual")

    def breaks(_: dict[str, Any]) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        pleach.fit(GOAL, progress=breaks, **SMALL)
    pleach.fit(GOAL, progress=True, **SMALL)


def test_python_goes_on_while_a_fit_runs() -> None:
    """The lock is released: another thread counts while this one waits."""
    import threading

    ticks: list[float] = []
    done = threading.Event()

    def count() -> None:
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.01)

    counter = threading.Thread(target=count)
    counter.start()
    pleach.fit(GOAL, start="acer", size=96, timeout=3, individual=False)
    done.set()
    counter.join()
    assert len(ticks) > 50 and np.median(np.diff(ticks)) < 0.1


def interrupted(script: str, tmp_path: pathlib.Path, after: str) -> tuple[int, str, float]:
    """Runs a script, interrupts it once it has said `after`, and returns its code, its words and the seconds to its end."""
    if sys.platform == "win32":
        pytest.skip("Windows sends no such signal to one process")
    file = tmp_path / "script.py"
    # A shell without job control has its background jobs ignore the signal, and what they start inherits that.
    heed = "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
    file.write_text(heed + textwrap.dedent(script))
    running = subprocess.Popen([sys.executable, "-u", file], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert running.stdout is not None
    said = ""
    for line in running.stdout:
        said += line
        if after in line:
            break
    running.send_signal(signal.SIGINT)
    begun = time.monotonic()
    rest, _ = running.communicate(timeout=60)
    return running.returncode, said + rest, time.monotonic() - begun


def test_ctrl_c_ends_a_fit_with_what_it_has(tmp_path: pathlib.Path) -> None:
    script = f"""
        import pleach
        said = []
        def tell(step):
            if step["stage"] == "search" and step["evaluations"] > 40 and not said:
                said.append(print("searching"))
        found = pleach.fit({str(GOAL)!r}, start="acer", size=48, timeout=60, progress=tell)
        print(found.interrupted, found.evaluations > 40, found.species.name)
    """
    code, said, seconds = interrupted(script, tmp_path, "searching")
    assert (code, said.splitlines()[-1]) == (0, "True True acer"), said
    assert seconds < 10, seconds


def test_ctrl_c_before_there_is_anything_is_a_keyboard_interrupt(tmp_path: pathlib.Path) -> None:
    script = f"""
        import pleach
        said = []
        def tell(step):
            if step["stage"] == "guess" and not said:
                said.append(print("guessing"))
        try:
            pleach.fit({str(GOAL)!r}, size=256, timeout=60, progress=tell)
            print("found")
        except KeyboardInterrupt:
            print("nothing yet")
    """
    code, said, _ = interrupted(script, tmp_path, "guessing")
    assert (code, said.splitlines()[-1]) == (0, "nothing yet"), said


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not fork, or not beside threads")
def test_a_child_that_forks_after_a_fit_can_fit_too(found: pleach.Fit) -> None:
    import multiprocessing

    with multiprocessing.get_context("fork").Pool(2) as pool:
        both = pool.map_async(one_cost, [1, 1]).get(timeout=120)
    assert both[0] == both[1] == found.cost


def one_cost(seed: int) -> float:
    return pleach.fit(OTHER, seed=seed, **SMALL).cost


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"height": 0}, "height` is 0"),
        ({"height": float("nan")}, "height` is nan"),
        ({"size": 4}, "size` is 4"),
        ({"timeout": 0}, "timeout` is 0"),
        ({"timeout": float("nan")}, "timeout` is nan"),
        ({"timeout": 5, "individual": 9.0}, "less than the 5 s"),
        ({"individual": "nine"}, "400trees"),
        ({"individuals": 0}, "individuals` is 0"),
        ({"optimizer": "luck"}, "luck"),
        ({"objective": "beauty"}, "beauty"),
        ({"generator": "magic"}, "magic"),
        ({"start": "palm", "generator": "lsystem"}, "lsystem"),
        ({"start": "plam"}, "plam"),
        ({"free": ["lenght"]}, "lenght"),
        ({"threads": 0}, "threads"),
    ],
)
def test_options_that_cannot_be_are_told(options: dict[str, Any], message: str) -> None:
    with pytest.raises(pleach.PleachError, match=message):
        pleach.fit(GOAL, **{"start": "acer", "evaluations": 5, **options})


def test_everything_that_the_program_is_told_can_be_said(tmp_path: pathlib.Path) -> None:
    found = pleach.fit(
        GOAL,
        holdout_views=[(OTHER, 90)],
        optimizer={"cma": {"population": 8}},
        robust=2,
        tree="dark",
        **{**SMALL, "individual": False},
    )
    report = found.report
    assert report["optimizer"] == "cma" and report["optimizer_settings"]["population"] == 8 and report["robust"] == 2
    assert [view["file"] for view in report["holdout_views"]] == [str(OTHER)]
    assert report["options"]["tree"] == "dark" and report["options"]["evaluations"] == 40


def test_a_goal_of_ours_scores_one_at_its_own_numbers() -> None:
    tree = pleach.species("palm").grow(7)
    goal = tree.silhouette(128)
    height = float(tree.stats["height_m"])
    found = pleach.fit(goal, start="palm", tree_seed=7, height=height, evaluations=1, size=128, individual=False)
    assert found.card.iou > 0.97
    assert found.silhouette.shape == goal.shape


def test_margins_change_nothing() -> None:
    goal = pleach.species("acer").grow(3).silhouette(96)
    rows, columns = np.flatnonzero(goal.any(axis=1)), np.flatnonzero(goal.any(axis=0))
    tight = goal[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    padded = np.pad(tight, ((70, 0), (80, 60)))
    options: dict[str, Any] = {"start": "acer", "evaluations": 12, "size": 64, "individual": False}
    one, other = pleach.fit(tight, **options), pleach.fit(padded, **options)
    assert one.card == other.card
    assert (one.silhouette.shape, other.silhouette.shape) == (tight.shape, padded.shape)


def test_a_known_frame_is_checked_and_taken() -> None:
    goal = pleach.species("palm").grow(7).silhouette(96)
    options: dict[str, Any] = {"start": "palm", "evaluations": 2, "size": 96, "individual": False}
    found = pleach.fit(goal, frame=(0.05, 48.0, 96.0), **options)
    assert found.evaluations == 2
    with pytest.raises(pleach.FitError, match="above 0"):
        pleach.fit(goal, frame=(0.0, 48.0, 96.0), **options)
    with pytest.raises(pleach.GoalError, match="ground row"):
        pleach.fit(goal, frame=(0.05, 48.0, 960.0), **options)
    problem = pleach.Problem(goal, "palm", frame=(0.05, 48.0, 96.0), size=96)
    assert np.isfinite(problem.evaluate(problem.start[None, :])).all()


def test_a_posterior_has_intervals_and_trees() -> None:
    goal = pleach.species("palm").grow(5).silhouette(64)
    events: list[dict[str, Any]] = []
    found = pleach.fit(
        goal, start="palm", evaluations=16, size=64, individual=False, posterior=150, progress=events.append
    )
    known = found.posterior
    assert known is not None and known.species == "palm" and known.is_familiar
    assert any(event["stage"] == "posterior" and event["done"] == 150 for event in events)
    ratio = known.numbers["ratio"]
    assert ratio.posterior.low < ratio.posterior.median < ratio.posterior.high
    assert 0 < ratio.shrunk < 1 and ratio.prior.high - ratio.prior.low > ratio.posterior.high - ratio.posterior.low
    assert len(known.samples) == 8 and known.samples[0].grow().silhouette(32).any()
    assert pleach.fit(goal, start="palm", evaluations=16, size=64, individual=False).posterior is None
    with pytest.raises(pleach.FitError, match="posterior"):
        pleach.fit(goal, start="palm", evaluations=16, posterior=5)
