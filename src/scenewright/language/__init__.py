"""The language part, new and small: text -> story -> program, and program -> story -> plain English.

It stands beside `translate` until it can take its place.
"""
