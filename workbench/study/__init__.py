"""User studies: answers of participants, and paired comparisons of what they rated."""
