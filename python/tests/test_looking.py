"""The commands that look, through the program."""

import base64
import html
import json
import lzma
import math
import pathlib
import pickle
import re
import string
import struct

import pytest

import espalier as es

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUSH = """#define R 0.5
lsystem: bush
derivation length: 4
axiom: A(1)
A(x) --> F(x)[+A(x*R)][-A(x*R)]
endlsystem
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("looking") / "run"
    es.record(es.Scene(plants=[es.Plant(es.Model(text=BUSH), name="bush")]), folder)
    return es.open(folder)


def size_of_png(data):
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", data[16:24])


def test_a_run_a_model_and_a_scene_show_themselves(run):
    assert size_of_png(run._repr_png_()) == (480, 360)
    assert size_of_png(es.Model(text=BUSH)._repr_png_()) == (480, 360)
    picture = es.render(run, run.folder / "bush.png", size="64x48", colour_by="age", no_legend=True)
    assert size_of_png(picture.read_bytes()) == (64, 48)


def test_a_shared_page_needs_nothing_else(run, tmp_path):
    page = es.share(run, tmp_path / "bush.html", frames=3, title="</script><b>").read_text(encoding="utf-8")
    recording = json.loads(re.search(r'<script type="application/json" id="recording">(.*?)</script>', page, re.DOTALL)[1])
    assert recording["title"] == "</script><b>" and recording["steps"] == [0, 2, 4]
    of_python = string.digits + string.ascii_uppercase + string.ascii_lowercase + "!#$%&()*+-;<=>?@^_`{|}~"
    text = recording["packets"][0].translate(str.maketrans(recording["letters"], of_python))
    packets = lzma.decompress(base64.b85decode(text))
    for step in recording["steps"]:
        length, letters, _, shown = struct.unpack_from("<I4sIi", packets)
        assert letters == b"ESP1" and shown == step
        packets = packets[4 + length :]
    assert packets == b""
    assert page.count("</script>") == 2 and "src=" not in page[: page.index("<script")] and "EspalierView.playRecording()" in page


def test_cells_of_notebooks_show_the_page(run):
    for shown in (run, run.frames[2], es.Model(text=BUSH)):
        element = shown._repr_html_()
        assert element.startswith('<iframe sandbox="allow-scripts"') and element.count('"') == 6
        assert "EspalierView.playRecording()" in html.unescape(element)


def test_an_export_holds_the_last_frame(run, tmp_path):
    text = es.export(run, tmp_path / "bush.ply", sides=3).read_bytes()
    assert text.startswith(b"ply")
    assert es.export(es.Model(text=BUSH), tmp_path / "other.ply", sides=3).read_bytes() == text


def test_charts_are_drawn_and_plants_measured(run, tmp_path):
    assert es.plot([run, run], tmp_path / "chart.svg", quantity="height").read_text().lstrip().startswith("<")
    tables = es.analyse(run, step="last")
    assert tables["analysis"]["internodes"].tolist() == [15]


def test_check_and_translate():
    assert es.check(ROOT / "models" / "course" / "02-branching.l")["errors"] == []
    graph = sorted((ROOT / "models").rglob("*.pgraph"))[0]
    assert "lsystem:" in es.translate(graph)


def test_a_mistake_in_a_command_has_its_place(tmp_path):
    file = tmp_path / "bad.l"
    file.write_text("lsystem: 1\nderivation length: 2\naxiom: A(1)\nA(x) --> B(x+)\nendlsystem\n")
    with pytest.raises(es.Error) as caught:
        es.check(file)
    assert (caught.value.file, caught.value.line, caught.value.column) == (str(file), 4, 14)
    with pytest.raises(es.Error, match="--frob") as caught:
        es.check(file, frob=1)
    assert caught.value.line is None


def test_a_fit_finds_the_parameters_of_the_marks(tmp_path):
    model = tmp_path / "fork.l"
    model.write_text("#define R 0.5\n#define ANGLE 20\nlsystem: fork\nderivation length: 3\naxiom: A(1)\n"
                     "A(l) --> F(l)[+(ANGLE)A(l*R)][-(ANGLE)A(l*R)]\nendlsystem\n")
    radians = 35 * 3.141592653589793 / 180
    rows = ["axis,x,y", "0,0,0", "0,0,1"]
    for axis, side in ((1, -1), (2, 1)):
        rows += [f"{axis},0,1", f"{axis},{side * 0.8 * math.sin(radians)},{1 + 0.8 * math.cos(radians)}"]
    marks = tmp_path / "marks.csv"
    marks.write_text("\n".join(rows) + "\n")
    found = es.fit(model, marks, parameter=["R", "ANGLE"], steps=2)["parameters"]
    assert found["R"]["value"] == pytest.approx(0.8, abs=1e-5)
    assert found["ANGLE"]["value"] == pytest.approx(35, abs=1e-3)


def test_a_scan_and_a_data_set_are_tables(run, tmp_path):
    points = es.scan(run, tmp_path / "points.csv", at="4,1,4", angle=0.3, no_ground=True)
    assert len(points) > 5 and set(points["plant"]) == {"bush"}
    assert es.scan(run, tmp_path / "points.ply", at="4,1,4", angle=0.3, no_ground=True)["points"] == len(points)
    (tmp_path / "bush.l").write_text(BUSH)
    file = tmp_path / "bushes.toml"
    file.write_text('[dataset]\nmodel = "bush.l"\nsamples = 4\n[dataset.parameters]\nR = "0.3:0.6"\n'
                    '[scan]\nat = [[3, 1, 0]]\nangle = 4\nformat = "csv"\n')
    table = es.dataset(file, output=tmp_path / "set")
    assert len(table) == 4 and table["R"].between(0.3, 0.6).all() and (table["points"] > 0).all()
    assert table["split"].tolist() == es.dataset(file, output=tmp_path / "set")["split"].tolist()


def test_a_sweep_is_a_table_with_a_row_a_run(tmp_path):
    file = tmp_path / "bush.l"
    file.write_text(BUSH)
    table = es.sweep(file, vary={"R": [0.25, 0.5], "simulation.steps": "2..3"}, jobs=2)
    assert table["internodes"].tolist() == [3, 7, 3, 7]
    assert table["length"].tolist() == [1.5, 1.75, 2, 3]


def test_a_tree_is_saved(tmp_path):
    tree = es.tree(preset="shrub", seed=4, age=3)
    saved = tree.save(tmp_path / "shrub.glb")
    assert saved.read_bytes()[:4] == b"glTF"
    assert tree.save(tmp_path / "shrub.glb") != saved
    with pytest.raises(es.Error, match="no-such"):
        es.tree(preset="no-such").save(tmp_path / "none.glb")


def test_the_program_is_found_by_its_variable(monkeypatch):
    monkeypatch.setenv("ESPALIER_PROGRAM", "/no/such/program")
    with pytest.raises(es.Error, match="/no/such/program"):
        es.check(ROOT / "models" / "course" / "02-branching.l")


def test_models_and_scenes_can_be_pickled():
    model = pickle.loads(pickle.dumps(es.Model(text=BUSH, R=2)))
    assert str(model.derive(2)) == str(es.Model(text=BUSH, R=2).derive(2))
    scene = es.Scene(plants=[es.Plant(model, at=(1, 0, 0))], steps=2, seed=5)
    for copy in (scene, pickle.loads(pickle.dumps(scene))):
        frames = list(es.World(copy).run())
        assert len(frames) == 3 and frames[-1].internodes.base[0].tolist() == [1, 0, 0]
    course = pickle.loads(pickle.dumps(es.Scene.of(ROOT / "environments" / "course-light.toml", seed=3)))
    assert len(list(es.World(course).run(2))) == 3


def test_a_sweep_says_that_it_takes_files_and_knows_flags(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(es.Error, match="takes the file of a scene"):
        es.sweep(es.Scene(), vary={"R1": [0.8]})
    (tmp_path / "stem.l").write_text("lsystem: 1\nderivation length: 1\naxiom: F\nF --> FF\nendlsystem\n")
    (tmp_path / "s.toml").write_text(
        "[[plant]]\nmodel = 'stem.l'\n[environment.water]\nprocess = 'soil-water'\nvoxel = 1\n"
        "domain = { lower = [0, 0, 0], upper = [1, 1, 1] }\n"
    )
    table = es.sweep("s.toml", vary={"environment.water.depletion": [True, False], "simulation.seed": "1..2"})
    assert len(table) == 4
