"""Exercise 4: bring ten cars through the crossing in the middle of the lab's map.

Whoever stops in the crossing blocks it for all. VALUES replaces keys of the scenario `lab_cars`; their meaning is in
launch_scripts/scenarios/README.md. Each of the three that are given below stays as it is where VALUES leaves it out:

    contouring_weight            how much more an error across the path counts than one along it
    coordination                 what a plan keeps clear of: cooperative or strict
    coupling                     who takes part in whose planning: reachable_areas or all
    held_up_contouring_weight    contouring_weight of a car that others hold up, with right of way
    horizon_steps                how far a plan reaches
    priorities                   who plans first
    reference_rule               how far apart the points are that a plan follows
    right_of_way                 whether cars give way where routes cross or merge
    right_of_way_order           whose turn it is: longest_wait or nearest_end
    rounds                       how the plans of the others become known: sequential or two
"""

VALUES = {"right_of_way": False, "contouring_weight": 0, "held_up_contouring_weight": 0}

if __name__ == "__main__":
    import hlc

    run = hlc.rollout(hlc.load_scenario("lab_cars", cars=10, seed=5, steps=600, values=VALUES))
    speeds_mps = run.planned_speed_mps
    print(f"draw 5: {speeds_mps.mean():.3f} m/s, in the last 20 s {speeds_mps[-100:].mean():.3f} m/s")
