"""The figures of a study, drawn with matplotlib to scale and for print."""
