#!/usr/bin/env python3
"""Include order: which file may include which (ARCHITECTURE.md).

Usage: include_order_test.py SOURCE_DIR. Prints every include that breaks a rule; exit 1 if any.
"""
import pathlib
import re
import sys

STAGES = ["base", "vehicle", "map", "field", "plan", "simulate", "verify", "behaviour", "inclusion", "certificate", "cellular",
          "bitmap", "steer", "identify", "ceiling", "improve", "exchange", "report", "run", "compare", "tune",
          "view", "app"]
TOOLBOXES = {"base", "vehicle"}
ON_TOOLBOXES_ALONE = {"cellular", "steer", "identify"}
JOINERS = {"run", "compare", "tune", "view", "app"}
NOUNS = {
    "map": {"obstacle_map.hpp", "region.hpp", "gdal_session.hpp"},
    "field": {"field.hpp"},
    "plan": {"plan.hpp", "plan_record.hpp", "plan_digests.hpp", "plan_digests_json.hpp"},
    "simulate": {"flight.hpp", "flight_measures.hpp"},
    "verify": {"verdict.hpp", "flow.hpp", "region_of_interest.hpp", "region_of_interest_json.hpp", "section_view.hpp", "proof_view.hpp",
               "section_verdicts.hpp", "verdict_map.hpp"},
    "behaviour": {"behaviour_flight.hpp", "explained_behaviour.hpp"},
    "inclusion": {"parts.hpp", "contract_verdicts.hpp", "follow_proof.hpp"},
    "certificate": {"certificate.hpp", "contract_certificate.hpp"},
    "cellular": {"border_heading_set.hpp", "cell_sets.hpp"},
    "bitmap": {"border_bitmap.hpp", "bitmap.hpp", "sampled.hpp", "reachability_map.hpp"},
    "ceiling": {"ceiling.hpp"},
    "report": {"picture.hpp"},
}
# Libraries that must stay out of the core, and the folders that may name them.
OUTSIDE = [
    (re.compile(r"(gdal|ogr|cpl_|proj\.h|proj/)"), {"map", "exchange"}),
    (re.compile(r"yaml-cpp"), {"map"}),
    (re.compile(r"toml"), {"run"}),
    (re.compile(r"cairo"), {"report"}),
    (re.compile(r"CLI/|CLI11"), {"app"}),
    (re.compile(r"openssl"), {"base"}),
    (re.compile(r"zlib"), {"report"}),
    (re.compile(r"httplib"), {"view"}),
    (re.compile(r"nlopt"), {"tune"}),
]
# Outside the stages: what a vehicle needs of them.
RUNTIME = {"fairway/runtime.hpp", "fairway/contract_runtime.hpp", "fairway/contract_pilot.hpp"}
RUNTIME_STAGES = {"base", "vehicle", "verify"}
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]')


def violation(stage, is_test, is_header, quoted, target):
    if not quoted:
        for library, folders in OUTSIDE:
            if library.match(target) and stage not in folders:
                return f"{target} belongs to {', '.join(sorted(folders))} alone"
        if stage == "map" and is_header and target.startswith(("gdal", "ogr", "yaml", "cpl_")):
            return None if "gdal_" in target else "readers keep their libraries out of map headers"
        return None
    if target in RUNTIME:
        return None if stage in JOINERS or is_test else f"{target} is for programs, not for stages"
    parts = pathlib.PurePosixPath(target).parts
    testing = len(parts) == 4 and parts[2] == "testing"
    if (len(parts) != 3 and not testing) or parts[0] != "fairway" or parts[1] not in STAGES:
        return f'project headers are included as "fairway/STAGE/name.hpp", not "{target}"'
    if testing and not is_test:
        return f"{target} is for tests"
    other, name = parts[1], parts[-1]
    if other == stage:
        return None
    if STAGES.index(other) > STAGES.index(stage):
        return f"{other} comes after {stage}"
    if other in TOOLBOXES or stage in JOINERS or is_test:
        return None
    if stage in ON_TOOLBOXES_ALONE:
        return f"{stage} is built on the toolboxes alone, not on {target}"
    if name not in NOUNS.get(other, set()):
        return f"{target} is a verb of {other}; a stage includes the nouns of earlier stages"
    return None


def main():
    root = pathlib.Path(sys.argv[1])
    files = sorted(p for p in (root / "fairway").rglob("*") if p.suffix in {".hpp", ".cpp"})
    found = []
    for path in files:
        stage = path.relative_to(root / "fairway").parts[0]
        if path.parent == root / "fairway":
            for line in path.read_text().splitlines():
                match = INCLUDE.match(line)
                if match and match[1] == '"' and match[2] not in RUNTIME and path.suffix == ".hpp":
                    if match[2].split("/")[1] not in RUNTIME_STAGES:
                        found.append(f"{path}: {match[2]} is not for vehicles")
            continue
        if stage not in STAGES:
            found.append(f"{path}: {stage} is not among the stages {' '.join(STAGES)}")
            continue
        for number, line in enumerate(path.read_text().splitlines(), start=1):
            match = INCLUDE.match(line)
            if not match:
                continue
            is_test = path.stem.endswith("_test") or path.parent.name == "testing"
            problem = violation(stage, is_test, path.suffix == ".hpp", match[1] == '"', match[2])
            if problem:
                found.append(f"{path}:{number}: {problem}")
    for stage, names in NOUNS.items():
        for name in names:
            if not (root / "fairway" / stage / name).is_file():
                found.append(f"the noun fairway/{stage}/{name} is not there")
    order = (root / "fairway" / "CMakeLists.txt").read_text()
    if re.findall(r"add_subdirectory\((\w+)\)", order) != STAGES:
        found.append("fairway/CMakeLists.txt lists the stages in another order")
    documented = re.findall(r"^\| `(\w+)/` \|", (root / "ARCHITECTURE.md").read_text(), re.M)
    if documented != STAGES:
        found.append("ARCHITECTURE.md lists the stages in another order")
    print("\n".join(found) if found else f"{len(files)} files keep the order")
    return 1 if found or len(files) < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
