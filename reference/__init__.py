"""The mechanics: hand-written systems, the generated mechanism, and what certifies them."""
