"""The built robot's numbers, from looks at one label from many places.

`looks` are the data, `unknowns` what is solved for and how a look follows from it,
`common_effects` what all looks share beside it, `solve` the fit, `poses` where best to look from,
`identifiability` what the camera cannot tell, and `verdict` whether the result deserves to be
used.
"""
