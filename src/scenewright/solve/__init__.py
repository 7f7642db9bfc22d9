"""From a program on given routes to formulas and back: lowering, backends, results, explanation."""
