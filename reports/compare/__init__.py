"""One engine against one reference: when events happen, its trial, and the rows that judge it."""
