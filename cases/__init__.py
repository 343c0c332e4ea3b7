"""The cases: what is claimed about which scene, loaded from YAML."""
