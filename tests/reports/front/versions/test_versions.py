"""Releases of an engine beside each other: what one moved is seen, and what it lacks is said."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from given.command import NEW, textmech
from given.command.releases import DYING, HEAVIER, LACKING, SAME, index, wheel

from textmech.reports.front.versions.release import Release, here, place
from textmech.reports.tables import run_list, write
from textmech.reports.tables.diff.columns import Rule

NOW = here("pymunk") or ""


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Releases that are installed, and references that are solved, once for all tests."""
    return tmp_path_factory.mktemp("store")


@pytest.fixture
def case(tmp_path: Path, store: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("TEXTMECH_CACHE", str(store))
    index(monkeypatch, tmp_path / "index")
    file = tmp_path / "cart.yaml"
    file.write_text(NEW, encoding="utf-8")
    return file


def rows(folder: Path) -> Iterator[dict[str, str]]:
    return iter(run_list.table(folder / "versions.csv"))


@pytest.mark.mutant("a release of pymunk with another gravity")
@pytest.mark.slow
def test_a_release_that_moved_a_number_is_seen_and_one_that_did_not_is_not(
    case: Path, tmp_path: Path
) -> None:
    wheel(tmp_path / "index", "90.1", SAME)
    wheel(tmp_path / "index", "90.2", HEAVIER)
    words = (f"pymunk=={NOW}", "pymunk==90.1", "pymunk==90.2", case, "--settings", "tuned")
    done = textmech("versions", *words, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr  # FAILS is a finding
    assert f"90.1: 3 numbers, 0 moved since {NOW}" in done.stdout
    head, *lines = done.stdout.partition("* moved")[2].splitlines()
    assert head.split() == [NOW, "90.1", "90.2"]
    (angle,) = [line.split() for line in lines if line.startswith("  rod.angle")]
    name, unit, now, same, heavier = angle
    assert (name, unit, now) == ("rod.angle", "rad", same)
    assert heavier.startswith("*")
    assert float(heavier[1:]) > 10 * float(now)
    by_version: dict[str, list[dict[str, str]]] = {}
    for row in rows(tmp_path / "out"):
        by_version.setdefault(row["version"], []).append(row)
    now, equal, other = (by_version[version] for version in (NOW, "90.1", "90.2"))
    for row, its_equal in zip(now, equal, strict=True):
        assert its_equal == {**row, "version": "90.1", "release": "2"}
        assert row["moved"] == ""
    moved = [row for row in other if row["moved"]]
    assert {row["quantity"] for row in moved} >= {"rod.angle", "cart.x"}
    assert {row["change"] for row in moved} == {"regression"}
    assert {row["release"] for row in other} == {"3"}
    (angle,) = [row for row in moved if row["quantity"] == "rod.angle"]
    assert float(angle["ratio"]) > 10


@pytest.mark.slow
def test_what_a_release_lacks_is_a_row_that_says_so(case: Path, tmp_path: Path) -> None:
    wheel(tmp_path / "index", "91.1", LACKING)
    wheel(tmp_path / "index", "91.2", DYING)
    words = ("pymunk==91.1", "pymunk==91.2", case, "--out", tmp_path / "out")
    done = textmech("versions", *words)
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    assert "91.1: refused: adapter: pymunk" in done.stdout
    lacking, dying = rows(tmp_path / "out")
    assert lacking["verdict"] == "refused"
    assert lacking["because"].startswith("adapter: pymunk")
    assert "no module of this name any more" in lacking["because"]
    assert (dying["verdict"], dying["because"]) == ("crashed", "its process ended by signal 9")
    assert {row["case"] for row in (lacking, dying)} == {"cart"}


@pytest.mark.slow
def test_another_version_than_the_one_asked_for_is_never_taken_for_it(
    case: Path, tmp_path: Path
) -> None:
    wheel(tmp_path / "index", "92.1", SAME, says="92.0")
    done = textmech("versions", "pymunk==92.1", case)
    assert done.returncode == 2
    assert "pymunk==92.1: is asked for, and Python finds 92.0" in done.stderr


@pytest.mark.slow
def test_a_release_is_installed_once(case: Path, tmp_path: Path) -> None:
    wheel(tmp_path / "index", "93.1", SAME)
    said: list[str] = []
    release, among = Release("pymunk", "93.1"), tmp_path / "releases"
    first, second = (place(release, among, said.append) for _ in range(2))
    assert first == second
    assert said == ["installing pymunk==93.1"]
    assert [file.name for file in among.iterdir()] == [first.name if first else ""]


@pytest.mark.slow
def test_pieces_of_the_same_release_come_with_it(case: Path, tmp_path: Path) -> None:
    """And nothing else that it needs: that is this environment's."""
    for name, needs in (("pymunk", ["pymunk-core==94.1", "numpy", 'x==1; extra == "y"']),
                        ("pymunk-core", ["numpy==0.1; extra == \"z\""])):  # fmt: skip
        wheel(tmp_path / "index", "94.1", SAME, name=name, needs=needs)
    found = place(Release("pymunk", "94.1"), tmp_path / "releases", print)
    assert found is not None
    assert {path.name for path in found.glob("*.dist-info")} == {
        "pymunk-94.1.dist-info",
        "pymunk_core-94.1.dist-info",
    }


def test_this_environments_own_release_is_not_installed(tmp_path: Path) -> None:
    assert place(Release("pymunk", NOW), tmp_path, pytest.fail) is None


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["mojoco==3.3.7"], "did you mean 'mujoco'?"),
        (["MuJoCo==3.3.7"], "did you mean 'mujoco'?"),
        (["numpy==2.0.0"], "no such engine; known: mujoco, pymunk"),
        (["mujoco=3.3.7"], "should name one release, as mujoco==1.2.3"),
        (["mujoco>=3.3.7"], "should name one release"),
        (["mujoco=="], "should name one release"),
        (["mujoco==--index-url"], "should name one release"),
        (["mujoco==../wheels"], "should name one release"),
        (["mujoco==3.3.7\n"], "should name one release"),
        (["mujoco==3.3.7", "mujoco==3.3.7"], "named twice"),
        (["four_bar"], "name releases of an engine"),
        ([], "name releases of an engine"),
        (["pymunk==7.0.1", "four_baar"], "did you mean 'four_bar'?"),
        (["pymunk==7.0.1", "--settings", "tunned"], "did you mean 'tuned'?"),
    ],
)
def test_mistakes_are_said_before_anything_is_installed(
    words: list[str], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("textmech.reports.front.versions.release.subprocess.run", None)
    done = textmech("versions", *words)
    assert done.returncode == 2
    assert message in done.stderr


@pytest.mark.slow
def test_what_the_installer_says_is_passed_on(case: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """That there is no such release, with those that there are; that there is no network."""
    for version in ("7.3.1", "7.3.2"):
        wheel(case.parent / "index", version, SAME)
    done = textmech("versions", "pymunk==7.3.9", case)
    assert done.returncode == 2
    assert "(from versions: 7.3.1, 7.3.2)" in done.stderr
    assert "pymunk==7.3.9: cannot be installed: the installer says why above" in done.stderr
    monkeypatch.delenv("PIP_NO_INDEX")
    monkeypatch.delenv("PIP_FIND_LINKS")
    monkeypatch.setenv("PIP_INDEX_URL", "https://127.0.0.1:9/simple")
    done = textmech("versions", "pymunk==99.1", case)
    assert done.returncode == 2
    assert "Connection refused" in done.stderr


def test_the_committed_example_says_what_the_committed_reports_say() -> None:
    """Of the releases that both have; where they do not, CONTRIBUTING.md tells how to renew it."""
    errors = run_list.table(write.HERE / "tolerance.csv")
    keys = ("case", "engine", "version", "setting", "realised", "quantity")
    told = {tuple(row[key] for key in keys): row for row in errors}
    versions = {engine: set[str]() for engine in ("mujoco", "pymunk")}
    shared = 0
    for row in rows(write.HERE):
        versions[row["engine"]].add(row["version"])
        key = tuple(row[key] for key in keys)
        if key in told:
            shared += 1
            error, largest = (float(text or "nan") for text in (row["error"], told[key]["error"]))
            assert row["allowed"] == told[key]["allowed"], key
            assert not Rule().differ(error, largest, float(row["allowed"])), key
    assert shared > 200
    assert all(len(found) >= 4 for found in versions.values())


def test_the_committed_example_shows_the_release_that_moved_closed_loops() -> None:
    moved = {
        (row["case"].partition(".")[0], row["version"])
        for row in rows(write.HERE)
        if row["engine"] == "mujoco" and row["moved"] and row["error"] and row["change"] == "better"
    }
    assert {("four_bar", "3.7.0"), ("slider_crank", "3.7.0")} <= moved
    assert not {case for case, version in moved if version == "4.0.0"}
