"""Tables, statistics and figures of the rows that `evaluate` writes."""
