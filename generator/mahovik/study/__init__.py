"""Questions about a stand; so far where it rests."""
