"""The learned reader: a small network that was trained on descriptions with their meaning, and is sure or says nothing.

What enters: a description. What leaves: the program that it most likely means, with a probability. `pieces` cuts the
text, `network` computes, `reader` decides; `weights.npz` is made by `tools/train_reader`.
"""
