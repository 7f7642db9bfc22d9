"""Driving policies for the ego and reference driver models."""
