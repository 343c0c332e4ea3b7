"""Certifies the reference's own error: every answer that shares no algebra is compared."""
