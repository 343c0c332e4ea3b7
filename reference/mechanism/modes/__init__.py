"""What holds at a time: modes, what ends one, which follows, and impacts between them."""
