"""Design: parameters of a case for which a scalar of the result is least or largest."""
