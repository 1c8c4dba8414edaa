"""Parts of a scene in Python: measured surfaces, warnings, tables for notebooks."""
