"""The independent verdict: conditions over traces, margins.

`judgement.judge` judges a `case.Case`; `files.judge_run_directory` judges what lies on disk. Both see the program,
the trace and facts of the map, and nothing of plans and solvers.
"""
