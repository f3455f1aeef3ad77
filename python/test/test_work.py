"""Threads, the interpreter's lock, progress, Ctrl-C, memory."""
import gc
import os
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from halfspace import Display, Error, ErrorCode, Solid, View


def many(count=40, segments=24):
    ball = Solid.sphere(1, segments)
    return Solid.union_of(ball.translated((0.37 * i, 0.11 * (i % 5), 0))
                          for i in range(count))


def test_progress_rises_and_may_stop():
    shares = []
    many().evaluate(progress=shares.append, threads=1)
    assert shares == sorted(shares) and shares[-1] == 1
    with pytest.raises(Error) as caught:
        many().evaluate(progress=lambda share: share < 0.3)
    assert caught.value.code is ErrorCode.STOPPED


def test_what_progress_raises_comes_out():
    class Mine(Exception):
        pass

    def raises(share):
        raise Mine

    solid = many()
    with pytest.raises(Mine):
        solid.evaluate(progress=raises)
    assert solid.volume() > 4  # and nothing is kept of it


def test_ctrl_c_stops_a_question():
    ball = Solid.sphere(1, 64)
    solid = ball
    for i in range(1, 40):  # no two of these are one step
        moved = ball.translated((0.37 * i, 0, 0))
        solid = solid - moved if i % 2 else solid + moved
    shares = []
    begin = time.perf_counter()
    solid.translated((0, 0, 0)).evaluate(progress=shares.append)
    in_full = time.perf_counter() - begin
    timer = threading.Timer(in_full / 8, os.kill, (os.getpid(), signal.SIGINT))
    begin = time.perf_counter()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        solid.volume()
        time.sleep(2 * in_full + 5)  # if it was quicker than the signal
    assert time.perf_counter() - begin < in_full
    assert len(shares) > 20


def test_other_threads_run_meanwhile():
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    ball = Solid.sphere(1, 256)
    part = ball - ball.translated((0.3, 0.2, 0.1))
    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    part.evaluate()
    end = time.perf_counter()
    stop.set()
    thread.join()
    # One boolean is one call: nobody else would run if it kept the lock.
    during = [t for t in ticks if begin < t < end]
    assert len(during) > 3, (len(during), end - begin)


def test_threads_share_solids_and_displays():
    solid = many(12, 16)
    display = Display.of(solid)
    view = View(width_px=64, height_px=48)
    expected = display.render(view).ids

    def work(i):
        if i % 3 == 0:
            display.insert(([(9, 9, 9), (9.5, 9, 9), (9, 9.5, 9)],
                            [(0, 1, 2)]))
            return True
        return solid.volume() > 0 and display.visible_map(view) is not None

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(work, range(24)))
    assert (display.render(View(width_px=64, height_px=48)).ids.shape ==
            expected.shape)
    assert display.polygon_count == len(solid.mesh()) + 8


def resident_kb():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") // 1024


def test_ten_thousand_solids_leave_no_memory():
    def loop(count):
        for i in range(count):
            part = Solid.box((0, 0, 0), (1, 1, 1)) - \
                Solid.box((0, 0, 0), (0.5, 0.5, 1 + i % 2))
            V, F = part.mesh(triangles=True)
            assert len(F) == 20
        gc.collect()

    loop(2_000)
    before = resident_kb()
    loop(10_000)
    # Less than 100 bytes a loop: a solid has thousands.
    assert resident_kb() - before < 1_000
