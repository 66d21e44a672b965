"""The byte code of the RCX as data: its op codes and sources, the image files of nqc, and their listing."""
