"""Labels to print: what stands in them, who made them, and the sheet they are cut from."""
