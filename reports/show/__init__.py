"""What a person sees: terminal, summary, scripts."""
