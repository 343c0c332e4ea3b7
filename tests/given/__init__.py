"""What several tests are given: scenes, systems with their parameters, laws to hold them to."""
