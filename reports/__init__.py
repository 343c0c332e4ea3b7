"""The reports: comparing, judging, writing, the command, the plug-in, and the committed tables."""
