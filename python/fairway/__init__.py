"""Verified feedback motion plans for vehicles with a minimum turning radius.

For every place on a map, the heading to steer; exact flights under that plan; and a proof of what
the vehicle does from every place and heading.

World: x east, y north, metres. Headings are radians, counter-clockwise from east. Arrays over a
map are [ny, nx] with the lowest row first; states are rows x_m, y_m, heading_rad.

    import fairway
    plan = fairway.plan_arrays(obstacles, 4.0, speed_mps=10.0, turn_radius_m=12.0, goal_m=(600, 400))
    flights = plan.fly(plan.random_starts(1000, seed=1))
    certificate = fairway.verify(plan)
    verdict, time_bound_s = certificate.query([[100.0, 80.0, 0.5]])

The work is done by the extension _fairway, without the GIL; nothing is computed here.
"""

from fairway._fairway import (
    After,
    Bitmap,
    Certificate,
    ClfLaw,
    ContractCertificate,
    ContractPilot,
    DubinsPath,
    Flights,
    InputError,
    MissionRefused,
    ModePilot,
    ObstacleMap,
    Outcome,
    Picture,
    Plan,
    Region,
    RunResult,
    Sampled,
    Scenario,
    ShortestLaw,
    SteeringFlight,
    Trajectory,
    Verdict,
    WaypointFlight,
    WaypointLeg,
    __version__,
    check,
    draw_bitmap,
    follow_waypoints,
    limit_threads,
    load_bitmap,
    load_certificate,
    load_plan,
    plan,
    plan_arrays,
    read_contract,
    read_map,
    run,
    shortest_path,
    steer,
    verify,
)

__all__ = [
    "After",
    "Bitmap",
    "Certificate",
    "ClfLaw",
    "ContractCertificate",
    "ContractPilot",
    "DubinsPath",
    "Flights",
    "InputError",
    "MissionRefused",
    "ModePilot",
    "ObstacleMap",
    "Outcome",
    "Picture",
    "Plan",
    "Region",
    "RunResult",
    "Sampled",
    "Scenario",
    "ShortestLaw",
    "SteeringFlight",
    "Trajectory",
    "Verdict",
    "WaypointFlight",
    "WaypointLeg",
    "check",
    "draw_bitmap",
    "follow_waypoints",
    "limit_threads",
    "load_bitmap",
    "load_certificate",
    "load_plan",
    "plan",
    "plan_arrays",
    "read_contract",
    "read_map",
    "run",
    "shortest_path",
    "steer",
    "verify",
]
