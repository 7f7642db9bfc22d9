"""The method measured: benchmarks, sweeps, coverage."""
