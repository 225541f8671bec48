"""Questions about a stand.

Enters: a stand, a regime or a required motion. Leaves: runs, programmes, studies, designs.
"""
