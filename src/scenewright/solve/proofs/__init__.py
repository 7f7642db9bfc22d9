"""Whether a scenario can happen: a proof that it cannot, a motion that shows that it can, or neither in time."""
