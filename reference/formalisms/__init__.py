"""The chapter's formalisms, applied to the ingredients of any Mode.

They never look at the explicit accelerations: what they answer is a second answer.
"""
