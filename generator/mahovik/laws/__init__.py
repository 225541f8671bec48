"""Laws of wrenches, one folder each; `contract.laws` lists them and loads their parts."""
