# SPDX-License-Identifier: MIT
"""Progress, Ctrl-C, threads, errors and memory."""

import os
import pickle
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

from conftest import torus
from heap import bytes_in_use
import vantage

V, F = torus(24, 12, bump=0.1)
SMALL = torus(8, 6, bump=0.1)


def test_progress_never_goes_back_and_ends_at_one():
    calls = []
    vantage.best_view(V, F, progress=lambda stage, fraction: calls.append((stage, fraction)))
    fractions = [fraction for _, fraction in calls]
    assert fractions == sorted(fractions) and fractions[-1] == 1.0 and fractions[0] >= 0.0
    assert all(stage for stage, _ in calls)


def test_progress_is_called_on_the_calling_thread():
    threads = set()
    vantage.skeleton(V, F, progress=lambda *_: threads.add(threading.get_ident()))
    assert threads == {threading.get_ident()}


def test_what_progress_raises_ends_the_call():
    class Enough(Exception):
        pass

    def stop(_stage, _fraction):
        raise Enough

    with pytest.raises(Enough):
        vantage.best_view(V, F, progress=stop)


@pytest.mark.parametrize("keywords, kind", [
    ({"progress": 3}, TypeError), ({"threads": -1}, ValueError), ({"threads": 1025}, ValueError),
    ({"threads": "two"}, TypeError), ({"threads": 2**40}, ValueError), ({"threads": 10**400}, ValueError)])
def test_how_to_run_is_checked(keywords, kind):
    with pytest.raises(kind):
        vantage.kssm(V, F, **keywords)


INTERRUPTED = """
import os, signal, sys
import numpy as np
sys.path.insert(0, sys.argv[1])
from conftest import torus
import vantage
first = []
def progress(stage, fraction):
    if not first:
        first.append(stage)
        print("started", flush=True)
try:
    vantage.score(*torus(500, 250, bump=0.1), sphere=8, contraction="exact", progress=progress)
except KeyboardInterrupt:
    print("interrupted", vantage.directions(0).directions.shape, flush=True)
"""


def can_be_interrupted():
    """Of a process started in the background of a shell, whose children would ignore Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def test_ctrl_c_is_a_keyboard_interrupt_and_the_package_goes_on():
    here = os.path.dirname(__file__)
    with subprocess.Popen([sys.executable, "-c", INTERRUPTED, here], stdout=subprocess.PIPE, text=True,
                          preexec_fn=can_be_interrupted) as child:
        last_resort = threading.Timer(120, child.kill)
        last_resort.start()
        try:
            assert child.stdout.readline() == "started\n"
            child.send_signal(signal.SIGINT)
            rest, _ = child.communicate(timeout=60)
        finally:
            last_resort.cancel()
            child.kill()
    assert rest == "interrupted (12, 3)\n"
    assert child.returncode == 0


DAEMON = """
import sys, threading
sys.path.insert(0, sys.argv[1])
from conftest import torus
import vantage
started = threading.Event()
def progress(stage, fraction):
    started.set()
def work():
    while True:
        vantage.score(*torus(200, 100, bump=0.1), sphere=5, contraction="exact", progress=progress)
for _ in range(2):
    threading.Thread(target=work, daemon=True).start()
started.wait()
"""


def test_daemon_threads_do_not_disturb_the_end_of_the_interpreter():
    child = subprocess.run([sys.executable, "-c", DAEMON, os.path.dirname(__file__)],
                           capture_output=True, text=True, timeout=60, check=False)
    assert (child.returncode, child.stderr) == (0, "")


AT_EXIT = """
import atexit, sys
sys.path.insert(0, sys.argv[1])
from conftest import torus
atexit.register(lambda: print(len(vantage.score(*torus(8, 6), sphere=0))))  # runs after the package's own
import vantage
"""


def test_what_ends_the_interpreter_may_still_ask():
    child = subprocess.run([sys.executable, "-c", AT_EXIT, os.path.dirname(__file__)],
                           capture_output=True, text=True, timeout=60, check=False)
    assert (child.returncode, child.stdout, child.stderr) == (0, "12\n", "")


def test_other_threads_run_while_one_works():
    done, turns = threading.Event(), []

    def count():
        while not done.wait(0.001):
            turns.append(None)

    counter = threading.Thread(target=count)
    counter.start()
    turns_before = len(turns)
    vantage.best_view(*torus(48, 24, bump=0.1))
    turns_during = len(turns) - turns_before
    done.set()
    counter.join()
    assert turns_during > 20  # a held lock would let it run only when this thread looks up


def test_several_threads_get_what_one_gets():
    models = [torus(16, 8, bump) for bump in (0.0, 0.05, 0.1, 0.15)]
    alone = [vantage.best_view(*model, contraction="exact").json for model in models]
    found = [None] * len(models)

    def work(i):
        found[i] = vantage.best_view(*models[i], contraction="exact", threads=1 + i % 2).json

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(models))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == alone


def test_one_analysis_serves_many_threads():
    analysis = vantage.analyse(V, F)
    alone = vantage.score(analysis, sphere=2)
    found = [None] * 4

    def work(i):
        found[i] = vantage.score(analysis, sphere=2)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(scores, alone) for scores in found)


def test_bytes_do_not_depend_on_the_number_of_threads(cat):
    expected = vantage.kssm(cat, levels=True)  # by as many as there are cores
    for threads in (1, 3, 8):
        result = vantage.kssm(cat, levels=True, threads=threads)
        assert result.of_vertex.tobytes() == expected.of_vertex.tobytes(), threads
        assert result.displacement.tobytes() == expected.displacement.tobytes(), threads


def test_an_analysis_answers_as_the_model_does(fan):
    analysis, exact = vantage.analyse(fan, contraction="exact"), {"contraction": "exact"}
    assert vantage.best_view(analysis, search="rapid").json == vantage.best_view(fan, search="rapid", **exact).json
    expected = vantage.kssm(fan, **exact)
    assert np.array_equal(vantage.kssm(analysis).of_vertex, expected.of_vertex)
    assert np.array_equal(vantage.skeleton(analysis).nodes, vantage.skeleton(fan, **exact).nodes)
    assert np.array_equal(vantage.vertex_map(analysis, method="thickness"), expected.thickness)


def test_an_analysis_keeps_its_options(cat):
    analysis = vantage.analyse(cat, weight="area", contraction="exact")
    scores = vantage.score(analysis, sphere=0)
    assert np.array_equal(scores, vantage.score(cat, sphere=0, weight="area", contraction="exact"))
    assert not np.array_equal(scores, vantage.score(cat, sphere=0, weight="area"))
    assert not np.array_equal(scores, vantage.score(cat, sphere=0, contraction="exact"))
    with pytest.raises(vantage.InvalidInput, match="weight shapes the analysis"):
        vantage.best_view(analysis, weight="vertex")


def test_an_analysis_tells_what_the_shape_is():
    analysis = vantage.analyse(V, F)
    assert (analysis.closed, analysis.genus, analysis.components) == (True, 1, 1)
    assert analysis.diameter == pytest.approx(2 * (1 + 0.45), rel=0.1)
    assert vantage.skeleton(analysis).cycles == 1


@pytest.mark.parametrize("name, content, kind, also", [
    ("missing.ply", None, vantage.IoError, FileNotFoundError),
    ("broken.off", b"OFF\n3 1 0\n0 0 0\n", vantage.FormatError, ValueError),
    ("model.fbx", b"Kaydara", vantage.FormatError, ValueError),
    ("empty.obj", b"", vantage.Error, Exception),
])
def test_files_that_cannot_be_read_say_so(tmp_path, name, content, kind, also):
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content)
    for call in (vantage.load, vantage.best_view):
        with pytest.raises(kind) as caught:
            call(path)
        assert isinstance(caught.value, also) and isinstance(caught.value, vantage.Error)
        assert name in str(caught.value)


def test_a_path_does_not_end_at_a_null_character(tmp_path):
    (tmp_path / "a.off").write_bytes(b"OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                                     b"3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
    with pytest.raises(ValueError, match="null character"):
        vantage.load(f"{tmp_path}/a.off\0.off")


@pytest.mark.parametrize("scale, shift", [(1e100, 0), (1e-100, 0), (5e-324, 0), (1, 1e15)])
def test_what_nothing_can_be_computed_with_is_refused(scale, shift):
    for call in (vantage.best_view, vantage.skeleton, vantage.kssm):
        with pytest.raises(vantage.InvalidInput):
            call(np.eye(4, 3) * scale + shift, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def test_a_missing_file_has_its_errno(tmp_path):
    with pytest.raises(OSError) as caught:
        vantage.load(tmp_path / "missing.ply")
    assert caught.value.errno == 2 and type(caught.value) is vantage.MissingFileError
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is vantage.MissingFileError and (again.errno, str(again)) == (2, str(caught.value))


def test_a_file_that_is_there_but_cannot_be_read_is_not_missing(tmp_path):
    with pytest.raises(vantage.IoError) as caught:
        vantage.load(tmp_path)
    assert not isinstance(caught.value, FileNotFoundError)


def test_names_that_are_no_utf8_are_read(tmp_path):
    path = os.path.join(os.fsencode(tmp_path), b"caf\xe9.obj")
    with open(path, "wb") as file:
        file.write(b"g \xff\xfe\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    model = vantage.load(os.fsdecode(path))
    assert model.name == "caf\ufffd" and model.faces.tolist() == [[0, 1, 2]]


def test_results_can_be_pickled(cat):
    result = vantage.best_view(cat, search="rapid")
    again = pickle.loads(pickle.dumps(result))
    assert again.best.camera == result.best.camera and hash(again.best.camera) == hash(result.best.camera)
    assert again.best.camera != result.worst.camera and again.best.camera != "camera"
    assert again.json == result.json and np.array_equal(again.best.eye, result.best.eye)


@pytest.mark.parametrize("held", [vantage.Model(*SMALL), vantage.analyse(*SMALL, contraction="exact")], ids=repr)
def test_models_and_analyses_cannot_be_pickled_by_any_protocol(held):
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        with pytest.raises(TypeError, match="cannot pickle vantage._core"):
            pickle.dumps(held, protocol)


@pytest.mark.parametrize("kind, member", [(vantage.Model, "name"), (vantage.Analysis, "model")])
def test_what_new_alone_makes_says_that_it_holds_nothing(kind, member):
    unmade = kind.__new__(kind)
    for use in (lambda: getattr(unmade, member), lambda: repr(unmade), lambda: vantage.kssm(unmade)):
        with pytest.raises(TypeError, match="holds nothing"):
            use()


@pytest.mark.parametrize("call", [
    lambda: vantage.kssm(*SMALL, levels=True, contraction="exact"),
    lambda: vantage.skeleton(*SMALL, levels=True, contraction="exact"),
    lambda: vantage.visible_vertices(*SMALL, sphere=0), lambda: vantage.Model(*SMALL).vertices,
    lambda: vantage.render(*SMALL, direction=(0, 0, 1), size=8, quality="draft"),
    lambda: vantage.best_view(*SMALL, search="exhaustive", subdivisions=0, contraction="exact"),
    lambda: pytest.raises(vantage.InvalidInput, vantage.kssm, SMALL[0], SMALL[1] + 1),
], ids=["kssm", "skeleton", "visible_vertices", "Model", "render", "best_view", "error"])
def test_a_hundred_calls_leave_nothing_behind(call):
    for _ in range(10):
        call()
    left = []
    for _ in range(5):
        before = bytes_in_use()
        for _ in range(100):
            call()
        left.append(bytes_in_use() - before)
        # One number for each of the 48 vertices left by every call would be 38 KB; nothing is. The
        # first hundreds may fill the allocator's stores of freed pieces, one for each thread.
        if left[-1] < 20_000:
            break
    assert left[-1] < 20_000, left
