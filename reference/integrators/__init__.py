"""Our integrators: one explicit, one implicit, and the step control they share."""
