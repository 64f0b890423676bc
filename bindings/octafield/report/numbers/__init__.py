"""The numbers of a report: records of runs, their tables, profiles and deviations."""
