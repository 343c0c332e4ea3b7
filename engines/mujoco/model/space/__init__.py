"""Parts of MuJoCo's file that are written otherwise for scenes in space."""
