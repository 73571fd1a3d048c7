#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a collection of millions costs, from the measured cost of a sample of it.

    vantage batch SAMPLE -o DIR --jobs 1; vantage results export DIR --timings -o sample.csv
    scripts/simulate_scale.py sample.csv [--models 10000000] [--bytes-per-model N]

Draws as many models as asked from the sample (with replacement), deals them to shards, and plays the
queue: a slot takes the next shard, failures and preemptions give shards back, which then go on where
they were. Prints Markdown; the same numbers every time (seeded).
"""

import argparse
import csv
import heapq
import random

START_S = 2.0          # From a free slot to a running shard: what Slurm took on loopback, doubled.
NOTICE_S = 60.0        # Until a lost node is noticed and its shard is queued again (SlurmdTimeout).
SCHEDULED_PER_S = 50   # Tasks a controller starts in a second. [assumed; loopback gives about 1]
HOUR = 3600.0


def read_costs(path):
    """Seconds of every model of the sample that was run."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    costs = sorted(float(r["seconds"]) for r in rows if r.get("attempts") not in ("", "0", None))
    if not costs:
        raise SystemExit(f"{path}: no model of it was run; export it with --timings")
    failed = sum(r["status"] == "failed" for r in rows)
    return costs, failed / len(rows)


def shard_works(costs, models, shards, rng):
    """Core-seconds of each shard: sizes vary as those of a hash do."""
    sizes = [models // shards] * shards
    spread = (models / shards) ** 0.5
    works = []
    for size in sizes:
        size = max(0, round(rng.gauss(size, spread)))
        works.append(sum(rng.choices(costs, k=size)))
    return works


def play(works, slots, failures_per_hour, preemptions_per_hour, in_flight_s, rng):
    """Makespan, busy seconds and lost seconds of the queue."""
    queue = list(reversed(works))           # pop() takes them in order
    back = []                               # (time it is queued again, work left)
    free = [i / SCHEDULED_PER_S for i in range(min(slots, len(works)))]
    heapq.heapify(free)
    end = busy = lost = 0.0
    rate = (failures_per_hour + preemptions_per_hour) / HOUR
    while queue or back:
        now = heapq.heappop(free)
        if queue:
            work = queue.pop()
        else:
            ready, work = heapq.heappop(back)
            now = max(now, ready)
        start = now + START_S
        stop = rng.expovariate(rate) if rate > 0 else float("inf")
        if stop < work:                     # the model in flight is lost, the others are kept
            waste = min(stop, rng.choice(in_flight_s))
            lost += waste
            busy += stop
            failed = rng.random() < failures_per_hour / (failures_per_hour + preemptions_per_hour)
            heapq.heappush(back, (start + stop + (NOTICE_S if failed else 0.0), work - stop + waste))
            heapq.heappush(free, start + stop + (NOTICE_S if failed else 0.0))
            end = max(end, start + stop)
        else:
            busy += work
            end = max(end, start + work)
            heapq.heappush(free, start + work)
    return end, busy, lost


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("sample", help="CSV of vantage results export --timings")
    parser.add_argument("--models", type=int, default=10_000_000)
    parser.add_argument("--bytes-per-model", type=int, default=300_000, help="of results")
    parser.add_argument("--price", type=float, default=0.04, help="of a core-hour")
    arguments = parser.parse_args()
    rng = random.Random(1)
    costs, failing = read_costs(arguments.sample)
    mean = sum(costs) / len(costs)
    quantile = lambda q: costs[min(len(costs) - 1, int(q * len(costs)))]
    print(f"{len(costs)} models: mean {mean:.2f} s, median {quantile(.5):.2f}, 99 % {quantile(.99):.2f}, "
          f"longest {costs[-1]:.1f}; {100 * failing:.1f} % fail\n")
    hours = arguments.models * mean / HOUR
    print(f"{arguments.models:,} models: {hours:,.0f} core-hours, {hours * arguments.price:,.0f} at "
          f"{arguments.price} a core-hour, {arguments.models * arguments.bytes_per_model / 1e12:.1f} TB\n")
    print("| shards | slots | failures | preemptions | hours | ideal | busy | lost |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for shards in (1000, 20000):
        works = shard_works(costs, arguments.models, shards, rng)
        for slots in (100, 1000, 10000):
            for failures, preemptions in ((0, 0), (1 / 500, 0), (1 / 500, 1 / 2)):
                end, busy, lost = play(works, slots, failures, preemptions, costs, rng)
                ideal = sum(works) / slots
                print(f"| {shards} | {slots} | {failures:.3f}/h | {preemptions:.1f}/h | {end / HOUR:.1f} | "
                      f"{ideal / HOUR:.1f} | {100 * busy / (end * slots):.0f} % | {100 * lost / busy:.3f} % |")


if __name__ == "__main__":
    main()
