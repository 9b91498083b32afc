"""A good answer to exercise 4: cars give way, and keep to their lanes just enough for it."""

VALUES = {"right_of_way": True, "contouring_weight": 30, "held_up_contouring_weight": 150}
