"""Polynomials with exact coefficients and formulas over them: what solvers, searches and planners are given."""
