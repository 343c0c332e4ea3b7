"""One engine against one reference: its steps, its runs, its audit."""
