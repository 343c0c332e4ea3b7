"""The chapter's laws by themselves: inertia, momentum, forces, friction. No scene."""
