"""What is in contact: measured surfaces, warnings of what is hardly meant, tables for notebooks."""
