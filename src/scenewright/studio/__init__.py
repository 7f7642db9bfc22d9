"""Run pages and reports for people to look at."""
