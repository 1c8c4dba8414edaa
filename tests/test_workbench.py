"""The workbench without a browser: fields, changes, doubts, files, server, texts for others."""

from __future__ import annotations

import contextlib
import http.client
import io
import json
import math
import urllib.error
import urllib.parse
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret

pytest.importorskip("dash")

from pyfret.workbench import edits
from pyfret.workbench.answers import PageNumber, answer_in_full, preview
from pyfret.workbench.doubts import doubt_of_sentence, doubts_of
from pyfret.workbench.events import SCENE_EVENTS, Context, change_scene
from pyfret.workbench.exports import read_link, write_file, write_link, write_script
from pyfret.workbench.fields import fields_of, find_field
from pyfret.workbench.file_views import describe, render_file
from pyfret.workbench.jobs import Jobs
from pyfret.workbench.judgements import first_yield, life_of
from pyfret.workbench.names import OWN, names_of
from pyfret.workbench.page import explore, open_workbench
from pyfret.workbench.presets import FIRST, PRESETS, make_preset
from pyfret.workbench.render import render_headline, render_numbers
from pyfret.workbench.sessions import START, Sessions
from pyfret.workbench.uploads import MOST_FILE, safe_parts
from pyfret.workbench.variants import verdict

SESSION = "0123456789abcdef"
pytestmark = pytest.mark.filterwarnings("ignore::pyfret._util.scene_warnings.SceneWarning")


def context(folder: Path, scene: fret.Scene, names: dict[str, str] | None = None) -> Context:
    """A browser that shows a scene."""
    sessions = Sessions(folder)
    return Context(sessions, Jobs(sessions), SESSION, scene, names_of(scene, names))


@pytest.mark.parametrize("name", PRESETS)
def test_every_field_of_every_preset_changes_what_it_names(name: str) -> None:
    scene, _ = make_preset(name)
    for group in fields_of(scene).values():
        for field in group:
            value = 1.1 * field.value or 1e6
            if field.whole:
                value = float(round(value) + 1)
            if field.key.endswith("T_x"):
                value = 0.9 * field.value
            changed = edits.replace_value(scene, field.key, value)
            read = find_field(changed, field.key)
            assert read is not None
            assert read.value == pytest.approx(value)
            assert read.unit == field.unit
            others = [f.key for g in fields_of(changed).values() for f in g]
            assert others == [f.key for g in fields_of(scene).values() for f in g]


@pytest.mark.parametrize("name", PRESETS)
def test_presets_have_named_materials_and_a_contact_on_their_grid(name: str) -> None:
    scene, names = make_preset(name)
    assert names_of(scene, names) == names
    assert OWN not in names_of(scene).values()
    scene.check()
    assert not [d for d in doubts_of(scene) if d.key == "grid.n"]


@pytest.mark.parametrize("shape", edits.SHAPES)
def test_every_shape_can_be_chosen(shape: str) -> None:
    scene = edits.replace_shape(make_preset(FIRST)[0], "body1", shape)
    assert edits.name_of_shape(scene.body1.shape) == shape


@pytest.mark.parametrize("kind", edits.CYCLES)
def test_every_load_cycle_has_fields_and_a_scene(kind: str) -> None:
    scene = edits.replace_cycle(make_preset(FIRST)[0], kind)
    scene.check()
    loads = {field.key.rpartition(".")[2] for field in fields_of(scene)["loads"]}
    assert "W" in loads
    expected = {"bulk": {"T_x", "sigma_B"}, "none": set()}.get(kind, {kind})
    assert expected <= loads


def test_layers_are_added_moved_and_removed_with_their_names(tmp_path: Path) -> None:
    scene, names = make_preset(FIRST)
    for event, layers in (
        ({"event": "add", "part": "body2"}, ["TiN", "TiN"]),
        ({"event": "material", "part": "body2.coatings.0", "value": "CrN"}, ["CrN", "TiN"]),
        ({"event": "move", "part": "body2", "n": "0"}, ["TiN", "CrN"]),
        ({"event": "remove", "part": "body2", "n": "0"}, ["CrN"]),
        ({"event": "add", "part": "body1"}, ["CrN"]),
    ):
        changed, doubt = change_scene(context(tmp_path, scene, names), event)
        assert doubt is None
        assert changed is not None
        scene, names = changed[0], names_of(*changed)
        listed = [names[f"body2.coatings.{n}"] for n in range(len(scene.body2.coatings))]
        assert listed == layers
    assert names["body1.coatings.0"] == "TiN"
    assert names["body2"] == "titanium_6Al4V"


def test_a_doubt_stands_at_its_field_with_a_button_that_removes_it(tmp_path: Path) -> None:
    scene, _ = make_preset(FIRST)
    (doubt,) = doubts_of(scene)
    assert doubt.key == "body2.coatings.0.thickness"
    assert doubt.button == "use 113 cells"
    event = {"event": "remedy", "changes": '{"grid.n": 113}'}
    changed, refusal = change_scene(context(tmp_path, scene), event)
    assert refusal is None
    assert changed is not None
    assert doubts_of(changed[0]) == []


def test_a_refused_value_comes_with_the_value_that_allows_it(tmp_path: Path) -> None:
    scene, _ = make_preset(FIRST)
    event = {"event": "value", "key": "friction.mu", "value": "0.1"}
    changed, doubt = change_scene(context(tmp_path, scene), event)
    assert changed is None
    assert doubt is not None
    assert doubt.key == "friction.mu"
    assert doubt.button.startswith("use T_x = 0.9")
    import json

    remedy = {"event": "remedy", "changes": json.dumps(doubt.values)}
    changed, refusal = change_scene(context(tmp_path, scene), remedy)
    assert refusal is None
    assert changed is not None
    assert changed[0].mu == 0.1
    assert np.max(changed[0].path.T_x) == pytest.approx(0.9)


@pytest.mark.parametrize("text", ["", "x", "nan", "inf", "1e400", "1;2", "<script>"])
def test_what_is_no_number_is_refused_at_its_field(text: str, tmp_path: Path) -> None:
    event = {"event": "value", "key": "body2.coatings.0.thickness", "value": text}
    changed, doubt = change_scene(context(tmp_path, make_preset(FIRST)[0]), event)
    assert changed is None
    assert doubt is not None
    assert doubt.key == "body2.coatings.0.thickness"
    assert "number" in doubt.sentence


@pytest.mark.parametrize("kind", SCENE_EVENTS)
def test_damaged_events_are_refused_with_a_sentence(kind: str, tmp_path: Path) -> None:
    scene, _ = make_preset(FIRST)
    event = {"event": kind, "key": "no", "value": "../../etc", "part": "body3", "n": "77"}
    event |= {"id": "..", "name": "../x", "changes": '{"a": 1}'}
    changed, doubt = change_scene(context(tmp_path, scene), event)
    assert (changed is None) != (doubt is None)
    if changed is not None:
        changed[0].check()


@pytest.mark.parametrize(
    ("sentence", "key"),
    [
        ("body2.E = 210 Pa is less than the softest gel's", "body2.E"),
        ("body1.shape.R = 5 m is large", "body1.shape.sphere.R"),
        ("the contact touches the border of the grid at increment 1", "grid.n"),
        ("friction.mu = -1: must be 0 or more", "friction.mu"),
    ],
)
def test_sentences_find_their_fields(sentence: str, key: str) -> None:
    assert doubt_of_sentence(make_preset(FIRST)[0], sentence).key == key


def test_a_link_holds_the_whole_scene() -> None:
    for name in PRESETS:
        scene, _ = make_preset(name)
        link = write_link(scene)
        assert fret.Scene.from_toml(read_link(link.removeprefix("#scene="))) == scene


@pytest.mark.parametrize("text", ["", "!!", "AAAA", "A" * 2_000_000, "eJw="])
def test_damaged_links_are_refused(text: str) -> None:
    with pytest.raises(ValueError, match="link"):
        read_link(text)


def test_a_link_that_unpacks_to_gigabytes_is_refused() -> None:
    import base64
    import zlib

    packing = zlib.compressobj(9)
    bomb = b"".join(packing.compress(bytes(1 << 20)) for _ in range(200)) + packing.flush()
    with pytest.raises(ValueError, match="damaged"):
        read_link(base64.urlsafe_b64encode(bomb).decode())


def test_a_link_that_names_a_file_is_refused(tmp_path: Path) -> None:
    import base64
    import zlib

    text = make_preset(FIRST)[0].to_toml()
    text = text.replace('shape = "flat"', 'shape = { height_map = { file = "x.npy" } }')
    value = base64.urlsafe_b64encode(zlib.compress(text.encode())).decode()
    event = {"event": "link", "value": value}
    changed, doubt = change_scene(context(tmp_path, make_preset(FIRST)[0]), event)
    assert changed is None
    assert doubt is not None
    assert "file" in doubt.sentence


@pytest.mark.parametrize(
    "path", ["", "/etc/passwd", "../x", "a/../../x", "a\\b", "a\0b", "x" * 200, "a/" * 20 + "b"]
)
def test_paths_out_of_the_folder_are_refused(path: str) -> None:
    with pytest.raises(ValueError, match="path"):
        safe_parts(path)


@pytest.mark.parametrize("session", ["", "..", "../../x", "A" * 16, "0" * 200, None])
def test_sessions_have_the_names_that_the_page_makes(session: Any, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="session"):
        Sessions(tmp_path).folder_of(session)


def test_a_scene_with_a_measured_surface_stays_on_the_server(tmp_path: Path) -> None:
    scene, names = make_preset(FIRST)
    heights = np.random.default_rng(0).normal(0.0, 1e-8, (128, 128))
    body = scene.body2.replace(shape=fret.SurfaceMap(heights, spacing=2e-6))
    rough = scene.replace(body2=body)
    sessions = Sessions(tmp_path)
    packed = sessions.pack(SESSION, rough, names)
    assert "toml" not in packed
    assert sessions.unpack(SESSION, packed) == (rough, names)
    with pytest.raises(ValueError, match="gone"):
        sessions.unpack("f" * 16, packed)
    # The scene that a page begins with is there for every browser.
    packed = sessions.pack(START, rough, names)
    assert sessions.unpack("e" * 16, packed) == (rough, names)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("x [um];depth [um]\n-10;0\n-5;0.5\n0;1\n5;0.5\n10;0\n", "scar"),
        ("Weg [µm];Kraft [N]\n-1;-2\n1;2\n0,5;1\n-1;-2\n", "loop"),
        (
            "x[um] y[um] z[um]\n"
            + "\n".join(f"{i} {j} {i * j}" for i in range(9) for j in range(9)),
            "map",
        ),
        ("<script>alert(1)</script>", "other"),
    ],
)
def test_dropped_files_are_recognized(text: str, kind: str, tmp_path: Path) -> None:
    path = tmp_path / "file.csv"
    path.write_text(text, encoding="utf-8")
    card = render_file(path, {"id": "a" * 16, "name": "<b>file</b>.csv"})
    if kind == "other":
        assert "doubt" in str(card)
        return
    assert describe(path)[0] == kind
    assert "Graph" in str(card)


def test_a_number_without_a_value_has_no_value_for_programs() -> None:
    rows = [PageNumber("largest x", "2.0", "Pa", 2.0), PageNumber("largest y", "no answer")]
    shown = [row.as_row() for row in rows]
    text = json.dumps(
        [render_numbers(shown).to_plotly_json(), render_headline(shown)],
        default=lambda part: part.to_plotly_json(),
    )
    assert text.count('"data-value"') == 2
    assert '"None"' not in text


def test_differences_count_beyond_both_errors() -> None:
    first = {"low": 1.0, "high": 2.0}
    assert verdict({"low": 2.1, "high": 3.0}, first).endswith("larger")
    assert verdict({"low": 0.1, "high": 0.9}, first).endswith("smaller")
    assert verdict({"low": 1.5, "high": 3.0}, first) == "no difference"
    assert verdict({"low": None, "high": None}, first) == ""


@pytest.mark.solves
def test_a_preview_is_near_the_full_answer_and_that_is_the_one_of_python() -> None:
    scene, names = make_preset(FIRST)
    early, full = preview(scene, None), answer_in_full(scene, names)
    result = fret.solve(scene, error="coarser", save="all", progress=False)
    values = {number.name: number for number in full.numbers}
    assert values["largest pressure"].value == 1e-6 * float(result.p_max[-1])
    below = result.at(-1).stress()
    for layer, label in enumerate(("TiN (coating)", "titanium_6Al4V (substrate)")):
        worst = below.maximum("von_mises", layer=layer)
        shown = values[f"largest von Mises stress, {label}"]
        assert shown.value == pytest.approx(1e-6 * worst.value, rel=1e-9)
        assert shown.high == pytest.approx(1e-6 * (worst.value + worst.error), rel=1e-9)
    for number in early.numbers:
        if number.value is not None and number.name in values:
            assert number.value == pytest.approx(values[number.name].value, rel=0.05), number.name
    layers = [None, fret.fatigue.Materials()["titanium_6Al4V"]]
    least = result.load_factors(layers).least("von_mises")
    assert first_yield(full.result, names).value == pytest.approx(least.value, rel=1e-9)
    life = life_of(full.result, names, "crossland")
    assert life.value == pytest.approx(result.life(layers, "crossland").range.best, rel=1e-9)


@pytest.mark.solves
def test_the_script_prints_the_numbers_of_the_page(monkeypatch: pytest.MonkeyPatch) -> None:
    import matplotlib.pyplot as plt

    scene, names = make_preset("Pad with bulk stress")
    script = write_script(scene, names_of(scene, names), "smith_watson_topper")
    printed = io.StringIO()
    monkeypatch.setattr(fret.Result, "report", lambda *_: None)
    monkeypatch.setattr(fret.Result, "to_csv", lambda *_: None)
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", lambda *_, **__: None)
    with contextlib.redirect_stdout(printed):
        exec(script, {})
    plt.close("all")
    answer = answer_in_full(scene, names)
    texts = [answer.numbers[-1].text, first_yield(answer.result, names).text]
    for text in texts:
        assert text.replace("±", "+-") in printed.getvalue()


@pytest.mark.solves
@pytest.mark.usefixtures("without_layout", "without_overview")
def test_all_files_of_the_fifth_tab_are_written(tmp_path: Path) -> None:
    scene, names = make_preset("Pad with bulk stress")
    heads = {
        "report.html": b"<!DOCTYPE html>",
        "figures.svg": b"<?xml",
        "figures.png": b"\x89PNG",
        "numbers.csv": b"increment",
        "scene.toml": b"schema = 1",
        "contact.py": b"import pyfret",
    }
    for name, head in heads.items():
        content = write_file(name, scene, names, "crossland", tmp_path)
        assert content.lstrip().startswith(head), name
    with pytest.raises(ValueError, match="no file"):
        write_file("../x", scene, names, "crossland", tmp_path)


@pytest.fixture
def page() -> Iterator[Any]:
    page = explore()
    yield page
    page.stop()
    assert not page.folder.exists()


def status(url: str, *, data: bytes | None = None, **headers: str) -> tuple[int, str]:
    """Send a request; status and text of the answer."""
    request = urllib.request.Request(url, data=data, headers=headers)
    try:
        with urllib.request.urlopen(request) as answer:
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, error.read().decode()


def test_only_requests_of_the_page_itself_are_answered(page: Any) -> None:
    assert page.url.startswith("http://127.0.0.1:")
    root = page.url[: page.url.index("/", 8) + 1]
    token = page.url.rstrip("/").rpartition("/")[2]
    assert len(token) == 32
    assert status(page.url)[0] == 200
    for url, headers in (
        (root, {}),
        (f"{root}{'0' * 32}/", {}),
        (f"{root}_dash-layout", {}),
        (f"{root}{token[:-1]}/", {}),
        (page.url, {"Host": "elsewhere.example"}),
        (page.url, {"Host": f"127.0.0.1.elsewhere.example:{root.rpartition(':')[2].rstrip('/')}"}),
        (page.url, {"Origin": "http://elsewhere.example"}),
        (page.url, {"Origin": "null"}),
    ):
        code, text = status(url, **headers)
        assert code == 403, (url, headers)
        assert text.endswith(".")
    changes = f"{page.url}_dash-update-component"
    assert status(changes, data=b"{}", Origin="http://elsewhere.example")[0] == 403
    with urllib.request.urlopen(page.url) as answer:
        policy = answer.headers["Content-Security-Policy"]
    assert "default-src 'none'" in policy
    assert "unsafe-eval" not in policy
    assert "http" not in policy


def test_uploads_stay_in_their_folder(page: Any) -> None:
    address = f"{page.url}upload/{SESSION}/{'a' * 16}"
    assert status(f"{address}?path=loop.csv", data=b"1,2\n")[0] == 200
    assert (page.folder / SESSION / f"drop-{'a' * 16}" / "loop.csv").read_bytes() == b"1,2\n"
    before = sorted(page.folder.rglob("*"))
    for query in ("../x", "/etc/x", "a/../../../x", "..\\x", ""):
        code, text = status(f"{address}?{urllib.parse.urlencode({'path': query})}", data=b"1")
        assert code == 400, query
        assert "path" in text
    assert status(f"{page.url}upload/..%2F..%2Fx/{'a' * 16}?path=x", data=b"1")[0] in (
        400,
        404,
        405,
    )
    assert status(f"{page.url}upload/{SESSION}/../../x?path=x", data=b"1")[0] in (400, 404, 405)
    assert sorted(page.folder.rglob("*")) == before


def test_files_of_a_gigabyte_are_refused_before_they_are_sent(page: Any) -> None:
    host, _, path = page.url.removeprefix("http://").partition("/")
    connection = http.client.HTTPConnection(host, timeout=10)
    connection.putrequest("POST", f"/{path}upload/{SESSION}/{'b' * 16}?path=x.npy")
    connection.putheader("Content-Length", str(5 * MOST_FILE))
    connection.endheaders()
    answer = connection.getresponse()
    assert answer.status == 413
    assert b"200 MB" in answer.read()
    connection.close()
    connection = http.client.HTTPConnection(host, timeout=10)
    connection.putrequest("POST", f"/{path}_dash-update-component")
    connection.putheader("Content-Length", str(10**9))
    connection.endheaders()
    assert connection.getresponse().status == 413
    connection.close()


def test_the_page_opens_scenes_stores_and_measured_files(tmp_path: Path) -> None:
    scene, _ = make_preset("Connector")
    file = tmp_path / "scene.toml"
    file.write_text(scene.to_toml(), encoding="utf-8")
    loop = Path(__file__).parent / "data" / "corpus" / "pandas_rig.csv"
    for source in (None, file, loop):
        page = open_workbench(source)
        try:
            assert status(page.url)[0] == 200
        finally:
            page.stop()
    with pytest.raises(FileNotFoundError):
        open_workbench(tmp_path / "absent.csv")
    assert math.isfinite(scene.mu)
