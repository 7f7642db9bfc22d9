"""From a program on given routes to formulas and back: lowering, proofs, witnesses, explanation; what a plan is."""
