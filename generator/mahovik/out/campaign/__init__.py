"""Campaigns: many samples of a stand whose numbers vary."""
