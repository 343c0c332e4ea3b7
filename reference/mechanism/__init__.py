"""The mechanism of any scene, from the scene alone: kinematics, constraints, forces, modes."""
