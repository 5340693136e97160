"""The user study: preparing it, taking part, and what the answers show."""
