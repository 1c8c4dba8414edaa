"""Workbench: a page for a browser that takes a contact from a drawing or a file to a decision.

``fields``, ``edits`` and ``presets`` are the model of the first tab: a scene and what can be
changed in it. ``answers``, ``judgements`` and ``jobs`` call the public functions of the package.
``uploads`` and ``file_views`` read dropped files, ``exports`` writes. ``layout`` and the modules
``callbacks_*`` are the page, ``server`` and ``page`` serve it on this machine.
"""
