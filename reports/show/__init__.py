"""What a person sees: terminal, summary, scripts, the benchmark."""
