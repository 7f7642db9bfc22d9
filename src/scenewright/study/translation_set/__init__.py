"""Descriptions with the meaning that a person reads in them: what translators are measured on.

What it holds: TOML files of ``[[text]]`` tables. Each has an ``id``, a ``group``, the ``text``, and either ``program``,
the text of a program (as in a `.scene` file) that means the same, or ``refuse``, why the text is to be refused:
``contradictory``, ``impossible geometry``, ``off-topic``, ``foreign language``, ``ambiguous``, ``no unit`` and so on.

- ``voices.toml``: whole descriptions in many voices, written by hand, of the taxonomy and beyond;
- ``fresh_actions.toml``: what the hero does and what comes of it, in words beside the common ones, and what to refuse;
- ``taxonomy.toml``: one description for each of the taxonomy's 80 rows, in mixed voices;
- ``phrases.toml``: one part of a description at a time, said in many ways;
- ``refusals.toml``: texts to be refused;
- ``fresh_*.toml``: one part of a description each (who drives where, when the hero acts, what it does), in the many
  constructions that texts by others showed to be missing;
- ``widened_*.toml``: a few short texts for each construction that was added later, with what is close to it and is to
  be refused.

No translator reads these files. The offline translator was widened with the mistakes made on them in mind, so its score
on them is a regression figure; a figure for new texts comes from texts that were not there when it was widened.
"""
