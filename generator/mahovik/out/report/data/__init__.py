"""Pages on measured data: orders against speed, measured and modelled; residual spectra; ellipses of confidence."""
