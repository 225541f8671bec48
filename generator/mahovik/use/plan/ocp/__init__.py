"""(13) with (12) as constraints, by IPOPT: the only part of `plan` that needs CasADi."""
