"""The harness itself: does it pass what is right, and catch what is wrong?"""
