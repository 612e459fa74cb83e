"""How well the label is located: a seeded data set, several methods, a table and a plot."""
