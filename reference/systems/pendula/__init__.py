"""Pendula: particles, bars and springs that swing."""
