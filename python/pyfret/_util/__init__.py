"""Helpers that know no contact."""
