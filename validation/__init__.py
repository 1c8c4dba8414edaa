"""The validation book: every truth that pyfret is measured against, computed anew.

``make validation`` solves the scenes, draws the figures and writes ``docs/validation``; nothing in
there is written by hand. A page is a :class:`~validation.truth.Truth`: a scene, what a closed form
says of it, and how to draw both.
"""
