"""Exercise 2: write a priority rule.

Six cars drive on the lab's roads. Who plans later keeps clear of the plans of those before it, and a car makes room for
those before it; right of way there is none. A bad order makes cars wait for those that cannot get away.

The rule is asked in every step, and must depend on the situation alone: every car has to get the same order.
"""
import hlc


def rule(situation: hlc.Situation):
    """Ids in the order in which the cars plan.

    situation.vehicles: ids, ascending; arrays have an entry per vehicle in this order
    situation.coupled: of each id those that it could meet within the horizon
    situation.poses: (V, 3): x [m], y [m], heading [rad]
    situation.speeds_mps, situation.standing_steps: (V,)
    """
    # As given: an order that knows nothing of the road.
    return sorted(situation.vehicles, reverse=True)


if __name__ == "__main__":
    run = hlc.rollout(hlc.load_scenario("lab_cars", cars=6, seed=3, steps=200,
                                        values={"right_of_way": False, "contouring_weight": 150}),
                      priorities=rule)
    print(f"draw 3: {run.planned_speed_mps.mean():.3f} m/s, {run.cost_m2.mean():.3f} m^2 for a plan")
