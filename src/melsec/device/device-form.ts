/** Device specification: the subcommands 000x, 0002/0003 (iQ-R), 0080/0081 and 0082/0083. */
export type DeviceForm = 'short' | 'long' | 'extendedShort' | 'extendedLong'
