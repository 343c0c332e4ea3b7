"""What MuJoCo is told while it runs: force laws, drivers, signals, a settled start."""
