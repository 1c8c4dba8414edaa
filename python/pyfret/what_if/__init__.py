"""Explorer: a contact that answers while its parameters are dragged, in a browser or a notebook.

``controls`` are the sliders, ``answer`` solves and draws, ``page`` serves both on this machine.
"""
