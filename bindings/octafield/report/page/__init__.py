"""The page of a report: its prose, figures, scenes and HTML."""
