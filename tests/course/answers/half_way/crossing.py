"""Half way to exercise 4: right of way, and no reason to keep to the middle of the lane."""

VALUES = {"right_of_way": True, "contouring_weight": 0, "held_up_contouring_weight": 0}
