"""The scenario as typed data: types, expressions, text form, checker, builder, evaluator.

Depends on no other package.
"""
