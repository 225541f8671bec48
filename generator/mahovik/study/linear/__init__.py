"""The linear model of a stand about a state, A, B, C, D, and its modes."""

from mahovik.study.linear.channels import Channel
from mahovik.study.linear.model import LinearModel, linear_model

__all__ = ["Channel", "LinearModel", "linear_model"]
