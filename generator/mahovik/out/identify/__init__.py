"""Numbers of a stand from measured data: prediction of channels, their derivatives, estimation, what cannot be seen."""
