"""Why a run missed, and what would do: found from its trace and records, never part of its judgement."""
