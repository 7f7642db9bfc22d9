"""The report of an experiment: figures, tables, measurements of its own, and a page that shows them."""
