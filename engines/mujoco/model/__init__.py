"""The scene as an MJCF file: what MuJoCo has for each body, joint, contact and force."""
