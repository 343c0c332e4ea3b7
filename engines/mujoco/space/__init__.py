"""Scenes in space as MuJoCo runs them: z up, native joints, the same file names first."""
