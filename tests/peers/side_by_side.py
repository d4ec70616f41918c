#!/usr/bin/env python3
"""Majorant and Mitsuba 3 in turns on the same scenes, machine and threads: a table of efficiencies and their ratio.

    cargo build --release
    python3 tests/peers/side_by_side.py --mitsuba peer/bin/python --mitsuba-s4 peer364/bin/python

Run from the project's root, on a machine that does nothing else. Rounds alternate between the two, so that both meet
the same disturbances; the ratio's interval is the range over rounds. `time_mitsuba.py` says how to set up the peers.
"""
import argparse
import json
import math
import subprocess

SCENES = {"S2": "side-lit cloud", "S3": "back-lit cloud", "S4": "chromatic plume"}


def majorant(scene, seconds):
    command = [
        "target/release/majorant", "bench", f"assets/oracle/{scene}/scene.toml", "--estimators", "uni-nee-mis",
        "--seconds", str(seconds), "--repeats", "4", "--json",
    ]
    line = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return json.loads(line.splitlines()[0])["efficiency"]["mean"]


def mitsuba(python, scene, spp):
    command = [python, "tests/peers/time_mitsuba.py", f"assets/oracle/{scene}", "--spp", str(spp)]
    line = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    answer = json.loads(line.splitlines()[-1])
    return answer["renderer"], answer["efficiency"]


def mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mitsuba", required=True, help="a Python that has Mitsuba")
    parser.add_argument("--mitsuba-s4", help="a Python that has Mitsuba 3.6.4")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=2.0)
    parser.add_argument("--spp", type=int, default=64)
    options = parser.parse_args()

    print("| scene | Majorant | peer | peer's | ratio |\n| --- | --- | --- | --- | --- |")
    for scene, about in SCENES.items():
        python = options.mitsuba_s4 if scene == "S4" and options.mitsuba_s4 else options.mitsuba
        ours, theirs, name = [], [], ""
        for _ in range(options.rounds):
            ours.append(majorant(scene, options.seconds))
            name, efficiency = mitsuba(python, scene, options.spp)
            theirs.append(efficiency)
        ratios = [a / b for a, b in zip(ours, theirs)]
        print(
            f"| {scene}, {about} | {mean(ours):.3g} | {name} | {mean(theirs):.3g} "
            f"| {mean(ratios):.1f} ({min(ratios):.1f} to {max(ratios):.1f}) |",
            flush=True,
        )


if __name__ == "__main__":
    main()
