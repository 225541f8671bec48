"""From a stand file to C. Enters: a stand file or a motion file. Leaves: checked SI data, formulas, a program, C."""
